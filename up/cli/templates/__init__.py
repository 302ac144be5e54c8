"""The files that 'up create' writes, as string.Template files."""
