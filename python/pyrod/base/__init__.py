"""What knows no rods: arrays that stay as they are, optional packages, progress, folders."""
