"""Plugin of rqt: publishes messages whose fields are expressions."""
