def main(arguments=None):
    return 2
