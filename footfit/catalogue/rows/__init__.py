"""The catalogue's rows: the schema, writing, reading, hashes, and the values made of them."""
