"""The passes that make a plan better, one a file; each takes a plan and gives one."""
