"""footfit: which shoe last fits this foot, and why?"""

__version__ = "0.1.0"
