"""The version of footfit, as documents, pages and the catalogue name it."""

__version__ = "0.1.0"
