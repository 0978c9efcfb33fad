"""Plugin of rqt: calls services with a request whose fields are expressions."""
