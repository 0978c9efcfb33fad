"""ROS messages as JSON, CBOR and BSON, and back, as rosbridge's protocol has them."""
