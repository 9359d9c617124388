"""pyrod beside other programs that solve rods: the same cases, side by side. Start with run.py."""
