"""Case files: YAML with units in, frozen descriptions out, every fault named with its line."""
