"""A folder that installs a version without a network: `up bundle` and its installer."""
