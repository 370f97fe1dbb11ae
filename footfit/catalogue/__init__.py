"""The only owner of SQL: schema, engine, migrations, store, search."""
