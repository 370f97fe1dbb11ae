"""Whom a library of lasts serves: feet as columns, shares, gaps, and lasts against lasts."""
