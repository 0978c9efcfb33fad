#error "there is no Ogre here: what cameras see is drawn by a process of its own, which plugins cannot enter"
