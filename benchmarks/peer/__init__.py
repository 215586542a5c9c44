"""The same work side by side with an open peer:  python -m benchmarks.peer --python PATH"""
