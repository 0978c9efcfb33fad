"""What a sourced workspace is to other programs."""
