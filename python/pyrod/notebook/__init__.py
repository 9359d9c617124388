"""What notebooks show of an object: a small table, and a picture drawn by lines of text (SVG)."""
