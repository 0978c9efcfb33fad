"""What one types (gazebo, gz, spawn_model, picture), over the services of a running simulator."""
