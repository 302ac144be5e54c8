"""A scrape of a metrics page as Prometheus does it, and a probe as Kubernetes does it."""

import json
import urllib.error
import urllib.request

from prometheus_client.parser import text_string_to_metric_families


def scrape(port):
    """Return the values by name and label values, in the order of the labels' names."""
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=20) as answer:
        text = answer.read().decode("utf-8")
    return {
        (sample.name, *(value for _, value in sorted(sample.labels.items()))): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }


def probe(port, page):
    """Return the status and the code of `live` or `ready`."""
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/{page}", timeout=20) as answer:
            return answer.status, json.load(answer)["code"]
    except urllib.error.HTTPError as error:
        return error.code, json.load(error)["code"]
