"""Tools built on `host_sim.api`: the folders are independent, and nothing else in host_sim imports them."""
