"""What a package exports with ``<rqt_bag plugin="..."/>`` and base ``rqt_bag::Plugin``."""


class Plugin:
    """A plugin of rqt_bag; any class with these methods is one."""

    def get_view_class(self):
        """A subclass of :class:`rqt_bag.TopicMessageView`, or None."""
        raise NotImplementedError()

    def get_renderer_class(self):
        """A subclass of :class:`rqt_bag.TimelineRenderer`, or None."""
        return None

    def get_message_types(self):
        """Names of the types that it is for; ``['*']`` for all."""
        return []
