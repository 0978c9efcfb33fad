"""People that walk through a world: ``<actor>`` of SDF, without physics.

``skeleton``   bones of a Collada file, their rest and their bind poses
``animation``  how the bones move over time: channels of a Collada file, or a BVH file
``script``     where an actor is, as a function of time
``skin``       the surface, cut into one rigid piece for each bone
``puppet``     an actor of a running world: puts the links where the script has them
"""
