//! The script for Slurm, run by Slurm itself on one node: an array job, and the link that depends on it. The test is
//! skipped with a message if the daemons are missing (Debian: slurmctld, slurmd, slurm-client, munge) or do not start.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use support::Scene;

const SHARDS: usize = 8;

/// A cluster on this machine, which ends with the test.
struct Cluster {
    folder: tempfile::TempDir,
    daemons: Vec<Child>,
}

impl Cluster {
    /// Starts the daemons. Returns `None` if they are missing or do not start, because they need root and many
    /// resources.
    fn start() -> Option<Cluster> {
        let is_there = |program: &str| {
            let found = Command::new("sh").args(["-c", &format!("command -v {program}")]).output().unwrap();
            found.status.success()
        };
        let is_root = said(&Command::new("id").arg("-u").output().unwrap()).trim() == "0";
        if !is_root || !["munged", "slurmctld", "slurmd", "sbatch"].into_iter().all(is_there) {
            eprintln!("skipped: Slurm's daemons are not on this machine, or this is not root");
            return None;
        }
        let mut cluster = Cluster { folder: tempfile::tempdir().unwrap(), daemons: Vec::new() };
        let folder = cluster.folder.path().to_owned();
        fs::write(folder.join("slurm.conf"), configuration(&folder)).unwrap();
        fs::write(folder.join("key"), [7; 64]).unwrap();
        said(&Command::new("chmod").arg("400").arg(folder.join("key")).output().unwrap());
        let path = |name: &str| folder.join(name).display().to_string();
        let munged = ["--key-file", "--socket", "--pid-file", "--log-file", "--seed-file"];
        let munged = std::iter::zip(munged, ["key", "socket", "munge.pid", "munge.log", "seed"]);
        let munged: Vec<String> = munged.map(|(flag, name)| format!("{flag}={}", path(name))).collect();
        cluster.daemon("munged", &[&["-F".to_owned(), "--force".to_owned()], munged.as_slice()].concat());
        let has_key = comes(|| folder.join("socket").exists());
        let configuration = ["-D".to_owned(), "-f".to_owned(), path("slurm.conf")];
        cluster.daemon("slurmctld", &configuration);
        cluster.daemon("slurmd", &configuration);
        if !has_key || !comes(|| cluster.ask("sinfo", &["-h", "-o", "%t"]).contains("idle")) {
            eprintln!("skipped: Slurm's daemons do not start on this machine");
            return None;
        }
        Some(cluster)
    }

    fn daemon(&mut self, program: &str, arguments: &[String]) {
        let log = || fs::File::create(self.folder.path().join(format!("{program}.out"))).unwrap();
        let daemon = Command::new(program).args(arguments).stdout(log()).stderr(Stdio::null()).spawn().unwrap();
        self.daemons.push(daemon);
    }

    /// Returns the output of a Slurm program.
    fn ask(&self, program: &str, arguments: &[&str]) -> String {
        let mut command = Command::new(program);
        let output = command.args(arguments).env("SLURM_CONF", self.folder.path().join("slurm.conf")).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Whether no job is waiting or running.
    fn is_idle(&self) -> bool {
        // The output includes column headings, which distinguishes it from that of a failed program.
        let jobs = self.ask("squeue", &[]);
        jobs.contains("JOBID") && jobs.lines().count() == 1
    }

    /// Runs the script of a project, and waits until all jobs have ended.
    fn submit(&self, scene: &Scene) {
        let mut script = Command::new("sh");
        script.args(["build/submit.sh", "--partition=short", "--output=slurm-%A-%a.out"]);
        // Jobs inherit the environment of the user who submits them.
        script.env("PATH", support::path_with_lipz(scene));
        script.env("SLURM_CONF", self.folder.path().join("slurm.conf")).current_dir(scene.path());
        said(&script.output().unwrap());
        assert!(comes(|| self.is_idle()), "jobs wait forever");
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        for daemon in self.daemons.iter_mut().rev() {
            let _ = daemon.kill();
            let _ = daemon.wait();
        }
    }
}

fn configuration(folder: &Path) -> String {
    let port = || TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let (folder, ports) = (folder.display(), [port(), port()]);
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
    let host = host.trim().split('.').next().unwrap();
    format!(
        "ClusterName=one\nSlurmctldHost={host}(127.0.0.1)\nSlurmUser=root\nSlurmdUser=root\n\
         AuthType=auth/munge\nAuthInfo=socket={folder}/socket\nCryptoType=crypto/munge\n\
         SlurmctldPort={}\nSlurmdPort={}\nStateSaveLocation={folder}/state\nSlurmdSpoolDir={folder}/spool\n\
         SlurmctldPidFile={folder}/slurmctld.pid\nSlurmdPidFile={folder}/slurmd.pid\n\
         ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\nReturnToService=2\n\
         SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\nSchedulerParameters=sched_interval=1,sched_min_interval=0\n\
         NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\nPartitionName=short Nodes={host} Default=YES State=UP\n",
        ports[0], ports[1]
    )
}

fn said(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Waits up to a minute for a condition. Returns whether it is met.
fn comes(is_there: impl Fn() -> bool) -> bool {
    let end = Instant::now() + Duration::from_secs(60);
    while Instant::now() < end {
        if is_there() {
            return true;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    false
}

#[test]
fn slurm_itself_runs_the_array_and_the_link() {
    let Some(cluster) = Cluster::start() else { return };
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    for line in 0..80 {
        scene.write(&format!("voices/{line}.lipz"), format!(r#"{{ "text_en-us": "Line {line}." }}"#));
    }
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    scene.prepare(&["shard", "plan", "pack", "--shards", &SHARDS.to_string(), "-o", "build/plan.json", "--quiet"]);
    scene.prepare(&["shard", "emit", "slurm", "build/plan.json", "-o", "build/submit.sh", "--quiet"]);
    let bank = || fs::read(scene.path().join("dialogue.lipzbank"));
    let whole = fs::read(scene.path().join("whole.lipzbank")).unwrap();
    cluster.submit(&scene);
    assert!(bank().unwrap() == whole);
    let objects = || {
        let files = fs::read_dir(scene.path().join("build")).unwrap().map(|file| file.unwrap().path());
        files.filter(|file| file.extension().is_some_and(|name| name == "lipzobj")).collect::<Vec<_>>()
    };
    // A file that differs from the plan: its task fails, the other tasks succeed, and the link does not run.
    fs::remove_file(scene.path().join("dialogue.lipzbank")).unwrap();
    fs::remove_dir_all(scene.path().join("build/store")).unwrap();
    assert_eq!(objects().len(), SHARDS);
    objects().iter().for_each(|object| fs::remove_file(object).unwrap());
    scene.write("voices/41.lipz", r#"{ "text_en-us": "Another line." }"#);
    cluster.submit(&scene);
    assert!(bank().is_err() && objects().len() == SHARDS - 1, "{:?}", objects());
    scene.prepare(&["shard", "plan", "pack", "--shards", &SHARDS.to_string(), "-o", "build/plan.json", "--quiet"]);
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    cluster.submit(&scene);
    assert!(bank().unwrap() == fs::read(scene.path().join("whole.lipzbank")).unwrap());
}
