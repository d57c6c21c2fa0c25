"""Policies as networks: ONNX files, checked before they run, and run without code of their own."""
