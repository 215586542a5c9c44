"""The stepped Timoshenko rotor without discretisation: a truth to measure elements against."""
