"""What 'up create' writes, as string.Template files, one for each file."""
