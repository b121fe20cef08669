"""What a flight brings: every value with its meaning, its place and its time; layers, pictures, files."""
