"""Exercises: behaviours of pupils, judged decision by decision."""
