"""A websocket for pages in a browser: rosbridge's protocol, version 2."""
