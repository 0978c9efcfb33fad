"""Providers that are plugins themselves: packages export them, this loads them and asks them for their plugins."""

from python_qt_binding.QtCore import qCritical

from qt_gui.application.reporting import describe
from qt_gui.composite_plugin_provider import CompositePluginProvider


class RecursivePluginProvider(CompositePluginProvider):
    """Loads every provider that ``plugin_provider`` finds, without a context, and offers their plugins."""

    def __init__(self, plugin_provider):
        super().__init__([])
        self.setObjectName("RecursivePluginProvider")
        self._plugin_provider = plugin_provider

    def discover(self, discovery_data):
        providers = []
        for descriptor in self._plugin_provider.discover(discovery_data):
            try:
                provider = self._plugin_provider.load(descriptor.plugin_id(), None)
            except Exception as error:  # a third party's provider must not take the others down
                qCritical(f"plugin provider '{descriptor.plugin_id()}' cannot be loaded: {describe(error)}")
            else:
                if provider is not None:
                    providers.append(provider)
        self.set_plugin_providers(providers)
        return super().discover(discovery_data)
