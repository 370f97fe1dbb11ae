"""Results as CSV text for spreadsheets."""
