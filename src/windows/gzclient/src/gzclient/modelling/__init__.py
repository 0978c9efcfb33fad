"""The model editor: bodies of simple shapes and meshes, joined by hand.

``draft``     what a hand does to a model, and where models are kept: no window, no ROS
``drawing``   the model in the page
"""
