"""Plugin of rqt: starts and stops the nodes of a launch file one by one."""
