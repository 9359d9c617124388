"""What a scene models and what it leaves out: effects, the choice of a model, solving with one."""
