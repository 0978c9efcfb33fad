"""Author information: who made the package."""

from moveit_setup_assistant.screens.base import Screen, form_layout, line


class AuthorScreen(Screen):
    """Name and e-mail address, which package.xml needs."""

    title = "Author Information"
    about = "The package's manifest names its maintainer: a name, and an address that works."

    def __init__(self, session) -> None:
        super().__init__(session)
        self._name, self._email = line(), line()
        self._name.setObjectName("author_name")
        self._email.setObjectName("author_email")
        form = form_layout()
        form.addRow("Name of the maintainer", self._name)
        form.addRow("E-mail of the maintainer", self._email)
        self.layout_.addLayout(form)
        self.layout_.addStretch(1)
        self._name.textChanged.connect(lambda text: setattr(self.config, "author_name", text.strip()))
        self._email.textChanged.connect(lambda text: setattr(self.config, "author_email", text.strip()))

    def enter(self) -> None:
        self._name.setText(self.config.author_name)
        self._email.setText(self.config.author_email)
