"""The nodes and topics of a running system as a graph."""
