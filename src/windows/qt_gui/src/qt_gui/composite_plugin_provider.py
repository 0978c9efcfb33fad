"""Several providers as one."""

from python_qt_binding.QtCore import qCritical

from qt_gui.application.reporting import describe
from qt_gui.errors import PluginLoadError
from qt_gui.plugin_provider import PluginProvider


class CompositePluginProvider(PluginProvider):
    """Asks each of its providers; a plugin is loaded by the one that found it."""

    def __init__(self, plugin_providers=None):
        super().__init__()
        self.setObjectName("CompositePluginProvider")
        self._plugin_providers = plugin_providers if plugin_providers is not None else []
        self._provider_of = {}  # plugin id -> provider
        self._running = []  # (instance, provider); an instance need not be hashable

    def set_plugin_providers(self, plugin_providers):
        self._plugin_providers = plugin_providers

    def discover(self, discovery_data):
        found = []
        for provider in self._plugin_providers:
            try:
                descriptors = list(provider.discover(discovery_data))
            except Exception as error:  # a third party's provider must not take the others down
                qCritical(f"plugin provider {type(provider).__name__} cannot find its plugins: {describe(error)}")
                continue
            for descriptor in descriptors:
                if self._provider_of.setdefault(descriptor.plugin_id(), provider) is provider:
                    found.append(descriptor)
        return found

    def load(self, plugin_id, plugin_context):
        provider = self._provider_of.get(plugin_id)
        if provider is None:
            raise PluginLoadError(f"no plugin '{plugin_id}' is known")
        instance = provider.load(plugin_id, plugin_context)
        self._running.append((instance, provider))
        return instance

    def unload(self, plugin_instance):
        for entry in self._running:
            if entry[0] is plugin_instance:
                self._running.remove(entry)
                entry[1].unload(plugin_instance)
                return

    def shutdown(self):
        for provider in self._plugin_providers:
            try:
                provider.shutdown()
            except Exception as error:
                qCritical(f"plugin provider {type(provider).__name__} cannot shut down: {describe(error)}")
