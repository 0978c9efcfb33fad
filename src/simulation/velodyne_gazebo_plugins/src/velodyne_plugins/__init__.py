"""Simulated Velodyne lidars."""
