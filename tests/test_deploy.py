"""The files of `deploy/` name what the programs have: keys, ports, metrics, credentials."""

import json
import re
import subprocess
from pathlib import Path

import pytest
import yaml

from tests.proxy.program import Program
from tests.support.nats_servers import nats_server
from tests.support.reactor import reactor
from up.system.figures import text_of
from up_cluster.config import FLEET, ClusterConfig
from up_proxy.config import PROXY, ProxyConfig
from up_proxy.proxy import Proxy
from up_runner.config import RUNNER, RunnerConfig
from up_runner.pool.pool import Pool
from up_runner.pool_config import PoolConfig
from up_runner.runner import Runner

DEPLOY = Path(__file__).parents[1] / "deploy"
MANIFESTS = sorted((DEPLOY / "kubernetes").glob("*.yml"))
PROBES = ("readinessProbe", "livenessProbe")
METRIC = re.compile(r"\b(?:up_[a-z_]+|process_[a-z_]+)")


def documents():
    return [each for path in MANIFESTS for each in yaml.safe_load_all(path.read_text())]


def named(kind, name):
    return next(
        each for each in documents() if (each["kind"], each["metadata"]["name"]) == (kind, name)
    )


def pods():
    kinds = ("Deployment", "StatefulSet", "DaemonSet")
    return [each for each in documents() if each["kind"] in kinds]


def load(file, text, folder):
    """Return the configuration in a text, as the program would load it."""
    (folder / file.filename).write_text(text)
    return file.load(folder)


def check_cluster(cluster: ClusterConfig, folder):
    assert len(cluster.addresses()) == cluster.replicas == 3
    assert {each.port for each in cluster.addresses()} == {4222}
    (folder / cluster.credentials).write_text("club:secret")
    (folder / cluster.credentials).chmod(0o600)
    assert cluster.login(folder) == {"user": "club", "pass": "secret"}


def test_kubernetes_runs_the_programs_with_their_ports_and_keys(tmp_path):
    proxy = load(PROXY, named("ConfigMap", "up-proxy")["data"]["proxy.yml"], tmp_path)
    check_cluster(proxy.cluster, tmp_path)
    fleet = load(FLEET, named("ConfigMap", "up-proxy")["data"]["fleet.yml"], tmp_path)
    assert (fleet.servers, fleet.credentials) == (proxy.cluster.servers, proxy.cluster.credentials)
    runner = load(RUNNER, named("ConfigMap", "up-runner")["data"]["runner.yml"], tmp_path)
    check_cluster(runner.pool, tmp_path)
    ports = {
        container["name"]: {each["name"]: each["containerPort"] for each in container["ports"]}
        for pod in pods()
        for container in pod["spec"]["template"]["spec"]["containers"]
    }
    assert ports["up-proxy"] == {"airborne": proxy.airborne_port, "ground": proxy.ground_port}
    assert ports["up-runner"] == {"requests": runner.port}
    probes = {
        container["name"]: [json.dumps(container[each]) for each in PROBES]
        for pod in pods()
        for container in pod["spec"]["template"]["spec"]["containers"]
        if container["name"] != "nats"
    }
    for shown in probes["up-proxy"]:
        assert f"/dev/tcp/127.0.0.1/{proxy.metrics_port} " in shown
    for page, shown in zip(("ready", "live"), probes["up-runner"], strict=True):
        get = json.loads(shown)["httpGet"]
        assert get == {"host": "127.0.0.1", "port": runner.metrics_port, "path": f"/{page}"}
    mounts = next(each for each in pods() if each["kind"] == "DaemonSet")["spec"]["template"]
    container = mounts["spec"]["containers"][0]
    # Not the volume's own folder, which belongs to root.
    folder = str(Path(runner.run_folder).parent)
    assert folder in {each["mountPath"] for each in container["volumeMounts"]}
    # What the shell replaces, and what it is replaced by.
    assert runner.pool.address in container["args"][0]
    assert f"${container['env'][0]['name']}/" in container["args"][0]


@pytest.mark.parametrize("pod", pods(), ids=lambda each: each["metadata"]["name"])
def test_each_pod_is_consistent(pod):
    labels = pod["spec"]["selector"]["matchLabels"]
    template = pod["spec"]["template"]
    assert template["metadata"]["labels"] == labels
    spec = template["spec"]
    claims = [each["metadata"]["name"] for each in pod["spec"].get("volumeClaimTemplates", ())]
    volumes = {each["name"] for each in spec["volumes"]} | set(claims)
    services = [each for each in documents() if each["kind"] == "Service"]
    for container in spec["containers"]:
        assert {each["name"] for each in container["volumeMounts"]} == volumes
        names = {each["name"]: each["containerPort"] for each in container["ports"]}
        for probe in PROBES:
            get = container.get(probe, {}).get("httpGet", {})
            # The loopback of a pod that has the machine's network.
            is_own = get.get("host") == "127.0.0.1" and spec.get("hostNetwork")
            assert not get or get["port"] in names or is_own
        for service in services:
            if service["spec"]["selector"] == labels:
                offered = {each["name"]: each["port"] for each in service["spec"]["ports"]}
                assert offered.items() <= names.items()
    maps = {each["metadata"]["name"] for each in documents() if each["kind"] == "ConfigMap"}
    wanted = {each["configMap"]["name"] for each in spec["volumes"] if "configMap" in each}
    # That of NATS is made of deploy/nats.conf.
    assert wanted - {"nats"} <= maps


def test_the_probes_of_a_proxy_tell_readiness_from_life(tmp_path):
    (container,) = named("Deployment", "up-proxy")["spec"]["template"]["spec"]["containers"]
    with Program(tmp_path, "cluster: {servers: 'nats://127.0.0.1:1'}") as proxy:

        def status(probe):
            *start, script, page = container[probe]["exec"]["command"]
            script = script.replace("9303", str(proxy.metrics_port))
            done = subprocess.run([*start, script, page], capture_output=True, check=False)
            return done.returncode, json.loads(done.stdout.splitlines()[-1])["code"]

        assert [status(each) for each in PROBES] == [(1, "cluster"), (0, "live")]


def test_the_image_has_a_user_that_kubernetes_knows_not_to_be_root():
    assert re.search(r"^USER [1-9]\d*$", (DEPLOY / "Dockerfile").read_text(), re.MULTILINE)


# Without quotation marks NATS reads numbers.
@pytest.mark.parametrize("password", ["4eb73ecb", "123456"])
def test_nats_reads_any_password(password):
    (container,) = named("StatefulSet", "nats")["spec"]["template"]["spec"]["containers"]
    (pod,) = (each["value"] for each in container["env"] if each["name"] == "UP_PASSWORD")
    services = yaml.safe_load((DEPLOY / "compose.yml").read_text())["services"]
    composed = services["nats-0"]["environment"]["UP_PASSWORD"]
    for value in (
        pod.replace("$(PASSWORD)", password),
        composed.replace("${UP_PASSWORD:?}", password),
    ):
        environ = {"NATS_NAME": "nats-0", "UP_PASSWORD": value}
        subprocess.run([nats_server(), "-t", "-c", DEPLOY / "nats.conf"], env=environ, check=True)


def test_compose_runs_three_nodes(tmp_path):
    compose = yaml.safe_load((DEPLOY / "compose.yml").read_text())
    services, configs = compose["services"], compose["configs"]
    kinds = [name.rpartition("-")[0] for name in services]
    assert {kind: kinds.count(kind) for kind in kinds} == {"nats": 3, "proxy": 3, "runner": 3}
    for name, service in services.items():
        for each in service.get("configs", ()):
            file = PROXY if each["target"].endswith("proxy.yml") else RUNNER
            config = load(file, configs[each["source"]]["content"], tmp_path)
            section = config.cluster if file is PROXY else config.pool
            check_cluster(section, tmp_path)
            assert {server.host for server in section.addresses()} <= set(services)
            page = f"http://127.0.0.1:{config.metrics_port}/ready'"
            assert page in service["healthcheck"]["test"][-1]
            if file is RUNNER:
                assert section.address == name and config.proxy.host in services
            else:
                inner = [int(port.rpartition(":")[2]) for port in service["ports"]]
                assert inner == [config.airborne_port, config.ground_port]
            targets = [secret["target"] for secret in service["secrets"]]
            assert targets == [str(Path(each["target"]).with_name(section.credentials))]


def test_nats_has_what_the_leases_rely_on():
    text = (DEPLOY / "nats.conf").read_text()
    page = (DEPLOY.parent / "docs" / "cluster.md").read_text()
    for line in ('ping_interval: "1s"', "ping_max: 2", 'write_deadline: "1s"'):
        assert line in text and line in page
    routes = re.findall(r"nats://([a-z0-9.-]+):6222", text)
    assert routes == [f"nats-{number}.nats" for number in range(3)]


def exported(folder):
    """Return the names of all metrics of a proxy and a runner in a cluster."""
    proxy = Proxy(reactor, ProxyConfig(cluster=ClusterConfig(servers="nats")))
    config = RunnerConfig(
        pool=PoolConfig(servers="nats", address="here", quota_instances=1),
        run_folder=str(folder / "run"),
    )
    runner = Runner(reactor, config, folder)
    (folder / "run").mkdir()
    pool = Pool(reactor, config, folder, runner.instances, runner.instance_host)
    runner.server.counts["malformed"] += 1
    figures = [*runner.instances.figures(), *runner.server.figures(), *pool.figures()]
    pages = proxy.page() + text_of(figures)
    return {line.split()[2] for line in pages.splitlines() if line.startswith("# TYPE")}


def test_each_metric_of_the_dashboard_is_exported(tmp_path):
    dashboard = json.loads((DEPLOY / "grafana" / "up.json").read_text())
    expressions = [each["expr"] for panel in dashboard["panels"] for each in panel["targets"]]
    used = {name for text in expressions for name in METRIC.findall(text)}
    assert len(used) > 15 and used - exported(tmp_path) == set()
