"""Names of the ROS graph along the branches of a tree."""


class RqtRosGraph:
    """A name space, as others import it."""

    DELIM_GRN = "/"

    @staticmethod
    def get_full_grn(model_index):
        """The name from the root of the tree down to an item: ``/wide_stereo/left/image_color``."""
        return RqtRosGraph.get_upper_grn(model_index, "")

    @staticmethod
    def get_lower_grn_dfs(model_index, grn_prev=""):
        """The names of all leaves below the item ``model_index``, beginning with its own.

        :param grn_prev: put before each name
        """
        here = f"{grn_prev}/{model_index.data()}"
        rows = model_index.model().rowCount(model_index) if model_index.isValid() else 0
        if not rows:
            return [here]
        return [name for row in range(rows) for name in RqtRosGraph.get_lower_grn_dfs(model_index.model().index(row, 0, model_index), here)]

    @staticmethod
    def get_upper_grn(model_index, str_grn):
        """``str_grn`` with the names of the item ``model_index`` and all above it put before it."""
        while model_index.isValid() and model_index.data() is not None:
            str_grn = f"/{model_index.data()}{str_grn}"
            model_index = model_index.parent()
        return str_grn
