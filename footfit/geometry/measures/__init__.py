"""What is measured in mm on a canonical right shape: landmarks and the table of measures."""
