"""What changed in meaning between two apps, in words: from two checked graphs to findings.

Names, comments, order and layout mean nothing here; what becomes of a mission does. Blocks are
matched first, renamed ones too; then each aspect of the two apps is compared in a file of its own.
"""
