"""What move_group can do, one class per plug-in name; each is made with the node's context and offers actions or
services."""
