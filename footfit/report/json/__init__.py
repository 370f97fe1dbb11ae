"""Results as JSON documents; docs/json.md lists every key."""
