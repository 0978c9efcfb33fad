"""What the YAML beside this cannot say."""


def models(context, count):
    found = len(context.bench.now.models)
    return found == count, f"{found} models are there"
