"""Makes and edits MoveIt configuration packages: the library below the assistant's window and its command line tools."""

from moveit_setup_assistant.errors import AssistantError

__all__ = ["AssistantError"]
