"""dynamic_reconfigure servers from a plain Python table.

No .cfg file, no generated code; ``rosrun dynamic_reconfigure dynparam``, ``dynamic_reconfigure.client`` and
rqt_reconfigure see no difference::

    from dynamic_parameters import Parameter, Server

    TABLE = [
        Parameter("time_step", float, 0.001, 0.0, 10.0, "Simulation time step in seconds"),
        Parameter("max_contacts", int, 20, 0, 100, "Contacts per collision pair"),
        Parameter("friction_model", str, "pyramid", description="...", enum={"pyramid": "two axes", "cone": "one"}),
        Parameter("auto_disable", bool, False, description="..."),
    ]

    def changed(config, level):           # config: dict name -> value, what a client asked for within its range
        world.dt = config["time_step"]    # return a dict to correct values, or None to accept them

    server = Server("/gazebo", TABLE, changed, initial={"time_step": world.dt})
    server.update({"time_step": 0.002})   # the program changed something itself: tell the clients
    server.shutdown()

Offered in the namespace: latched topics ``parameter_descriptions`` and ``parameter_updates``, service
``set_parameters``; the values are kept on the parameter server. A value that is already there when the server starts
wins over the table's default, and is kept within the table's range; ``initial`` wins over both. What the program itself says,
``initial``, ``update`` and what ``changed`` returns, holds as it is, as with ``updateConfig`` of the server in C++: only what
clients ask for is kept within the ranges. ``changed`` is called once at start with level -1, then
in a service thread at every change with the or-ed levels of the parameters that changed. What it raises then refuses the
change: one WARN line, and the client is told the values that still hold.

Where others change the values too, ``current=f`` makes the server ask ``f()`` for all of them before and after each
change, in the thread of the change, and ``server.refresh()`` shows them to the clients. ``initial`` must then be given in full.
"""

from .server import Parameter, Server

__all__ = ["Parameter", "Server"]
