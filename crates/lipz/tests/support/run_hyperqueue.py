"""Runs a job file on a server of HyperQueue with two workers, in the folder that is named."""

import sys
import tomllib
from pathlib import Path

from hyperqueue import Job
from hyperqueue.cluster import LocalCluster, WorkerConfig

job_file, folder = sys.argv[1:]
with open(job_file, "rb") as file:
    tasks = tomllib.load(file)["task"]
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    job = Job(max_fails=0)
    started = {}
    for task in tasks:
        dependencies = [started[number] for number in task.get("deps", [])]
        output = {"stdout": str(Path(folder) / "build/out.txt"), "stderr": str(Path(folder) / f"build/{task['id']}.txt")}
        started[task["id"]] = job.program(task["command"], cwd=folder, deps=dependencies, **output)
    client = cluster.client()
    client.wait_for_jobs([client.submit(job)])
