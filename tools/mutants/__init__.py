"""Small changes to footfit's code that a test should notice: ``make mutants``."""
