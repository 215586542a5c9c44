"""The same work here and in an open library, the peer:  python -m benchmarks.peer --python PATH"""
