"""Many lasts judged for one customer, by column: clearances, toe boxes, verdicts."""
