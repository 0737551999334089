// The precompiled header of the suites belongs to a target, and a target has a file.
