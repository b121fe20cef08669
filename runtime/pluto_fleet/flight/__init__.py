"""Flying an app in real time: starting, recording, commanding, recovering."""
