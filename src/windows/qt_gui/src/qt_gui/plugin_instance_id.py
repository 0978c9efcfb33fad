"""The name of one running plugin: which one, and its number."""


class PluginInstanceId:
    """``package/Plugin#2``; :meth:`tidy_str` is how settings and dock names spell it."""

    def __init__(self, plugin_id=None, serial_number=None, instance_id=None):
        if instance_id is not None:
            plugin_id, serial_number = str(instance_id).rsplit("#", 1)
        self.plugin_id = str(plugin_id)
        self.serial_number = int(serial_number) if serial_number is not None else None

    def __eq__(self, other):
        return str(self) == str(other)

    def __hash__(self):
        return hash(str(self))

    def __str__(self):
        return f"{self.plugin_id}#{self.serial_number}"

    def tidy_str(self):
        return f"{self.tidy_plugin_str()}__{self.serial_number}"

    def tidy_plugin_str(self):
        return self.plugin_id.replace("/", "__")
