"""The program rqt."""
