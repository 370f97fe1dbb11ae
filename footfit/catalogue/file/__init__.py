"""The catalogue as a file: opening, locks, copies, migrations, putting a backup in place."""
