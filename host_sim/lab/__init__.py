"""What is built above `host_sim.api`: each folder is an island, and nothing in host_sim imports it."""
