"""Which last fits a foot: fit profiles, zones, scores, ranking, reasons, comparison."""
