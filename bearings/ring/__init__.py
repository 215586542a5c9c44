"""All balls of a bearing: displacement, load or a mix of both gives the state and its tangents."""
