"""Image topics as pictures over HTTP, under the addresses and parameters of the package of this name."""
