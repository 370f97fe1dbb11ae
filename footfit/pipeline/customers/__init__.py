"""Customers and their feet: whose scans are whose, which foot is the left one, many answers."""
