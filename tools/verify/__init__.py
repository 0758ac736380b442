"""What verifies the code beyond its tests: mutants, coverage, MISRA C and sizes."""
