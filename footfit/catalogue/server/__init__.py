"""A catalogue on a PostgreSQL server, which several machines share."""
