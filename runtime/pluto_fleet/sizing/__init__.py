"""How many drones missions need: candidate fleets, flown until it is sure what each can promise."""
