"""The planners of ompl_planning.yaml with the parameters that MoveIt's own files give them (OMPL's defaults)."""

from __future__ import annotations

from typing import Any

_TREE = {"range": 0.0, "goal_bias": 0.05}
_INFORMED = {
    "use_k_nearest": 1,
    "rewire_factor": 1.001,
    "samples_per_batch": 100,
    "use_graph_pruning": 1,
    "prune_threshold_as_fractional_cost_change": 0.1,
    "delay_rewiring_to_first_solution": 0,
    "use_just_in_time_sampling": 0,
    "drop_unconnected_samples_on_prune": 0,
    "stop_on_each_solution_improvement": 0,
    "use_strict_queue_ordering": 0,
    "find_approximate_solutions": 0,
}
_SPARSE = {"stretch_factor": 3.0, "sparse_delta_fraction": 0.25, "dense_delta_fraction": 0.001}

PARAMETERS: dict[str, dict[str, Any]] = {
    "AnytimePathShortening": {"shortcut": True, "hybridize": True, "max_hybrid_paths": 24, "num_planners": 4, "planners": ""},
    "SBL": {"range": 0.0},
    "EST": _TREE,
    "LBKPIECE": {"range": 0.0, "border_fraction": 0.9, "min_valid_path_fraction": 0.5},
    "BKPIECE": {"range": 0.0, "border_fraction": 0.9, "failed_expansion_score_factor": 0.5, "min_valid_path_fraction": 0.5},
    "KPIECE": {**_TREE, "border_fraction": 0.9, "failed_expansion_score_factor": 0.5, "min_valid_path_fraction": 0.5},
    "RRT": _TREE,
    "RRTConnect": {"range": 0.0},
    "RRTstar": {**_TREE, "delay_collision_checking": 1},
    "TRRT": {
        **_TREE,
        "max_states_failed": 10,
        "temp_change_factor": 2.0,
        "min_temperature": 1e-09,
        "init_temperature": 1e-05,
        "frontier_threshold": 0.0,
        "frontier_node_ratio": 0.1,
        "k_constant": 0.0,
    },
    "PRM": {"max_nearest_neighbors": 10},
    "PRMstar": {},
    "FMT": {"num_samples": 1000, "radius_multiplier": 1.1, "nearest_k": 1, "cache_cc": 1, "heuristics": 0, "extended_fmt": 1},
    "BFMT": {
        "num_samples": 1000,
        "radius_multiplier": 1.0,
        "nearest_k": 1,
        "balanced": 0,
        "optimality": 1,
        "heuristics": 1,
        "cache_cc": 1,
        "extended_fmt": 1,
    },
    "PDST": {},
    "STRIDE": {
        **_TREE,
        "use_projected_distance": 0,
        "degree": 16,
        "max_degree": 18,
        "min_degree": 12,
        "max_pts_per_leaf": 6,
        "estimated_dimension": 0.0,
        "min_valid_path_fraction": 0.2,
    },
    "BiTRRT": {
        "range": 0.0,
        "temp_change_factor": 0.1,
        "init_temperature": 100,
        "frontier_threshold": 0.0,
        "frontier_node_ratio": 0.1,
        "cost_threshold": 1e300,
    },
    "LBTRRT": {**_TREE, "epsilon": 0.4},
    "BiEST": {"range": 0.0},
    "ProjEST": _TREE,
    "LazyPRM": {"range": 0.0},
    "LazyPRMstar": {},
    "SPARS": {**_SPARSE, "max_failures": 1000},
    "SPARStwo": {**_SPARSE, "max_failures": 5000},
    "AITstar": {**_INFORMED, "set_max_num_goals": 1},
    "ABITstar": {**_INFORMED, "initial_inflation_factor": 1000000, "inflation_scaling_parameter": 10, "truncation_scaling_parameter": 5.0},
    "BITstar": _INFORMED,
}


def names() -> list[str]:
    """All planners, in the order in which files list them."""
    return list(PARAMETERS)


def configurations() -> dict[str, dict[str, Any]]:
    """The mapping below ``planner_configs`` of ompl_planning.yaml."""
    return {name: {"type": f"geometric::{name}", **values} for name, values in PARAMETERS.items()}
