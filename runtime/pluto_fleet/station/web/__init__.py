"""From a request to an answer, safely; the web server is known here and nowhere else."""
