#!/usr/bin/env bash
# Runs a command beside a Slurm of one node: one_node_slurm.sh CPUS COMMAND...
# The node stands in namespaces of its own (network, processes, host name), which end with the
# command and take every daemon along. Exit status 77 where Slurm or the rights to do so are missing.
set -eu
if [ "${GENIO_SLURM_NAMESPACE:-}" != yes ]; then
  for program in sbatch slurmctld slurmd munged; do
    PATH=$PATH:/usr/sbin command -v $program >/dev/null ||
      { echo "SKIPPED: $program is missing; install slurm-wlm and munge" >&2; exit 77; }
  done
  [ "$(id -u)" -eq 0 ] || { echo "SKIPPED: a Slurm of one's own takes root" >&2; exit 77; }
  enter=(unshare --net --mount --uts --pid --fork --kill-child --mount-proc)
  "${enter[@]}" true 2>/dev/null ||
    { echo "SKIPPED: this machine does not let us make namespaces" >&2; exit 77; }
  GENIO_SLURM_NAMESPACE=yes exec "${enter[@]}" "$0" "$@"
fi
export PATH=$PATH:/usr/sbin
cpus=$1; shift
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
chmod 755 "$home"
hostname node
ip link set lo up
ip addr add 10.77.0.1/32 dev lo  # Slurm wants an address that is no loopback's
mkdir -p "$home/state" "$home/spool"
(umask 077; head -c 1024 /dev/urandom >"$home/munge.key")
cat >"$home/slurm.conf" <<CONF
ClusterName=genio
SlurmctldHost=node(10.77.0.1)
SlurmUser=root
AuthType=auth/munge
# A job that is put back waits until its credential has expired.
AuthInfo=socket=$home/munge.socket,cred_expire=5
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
SlurmctldLogFile=$home/slurmctld.log
SlurmdLogFile=$home/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2,sched_min_interval=0
MpiDefault=none
ReturnToService=2
KillWait=1
MinJobAge=3600
NodeName=node NodeAddr=10.77.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$home/slurm.conf
munged --force --key-file="$home/munge.key" --socket="$home/munge.socket" \
  --pid-file="$home/munge.pid" --log-file="$home/munge.log" --seed-file="$home/munge.seed" 2>/dev/null
slurmctld 2>>"$home/slurmctld.log"
slurmd 2>>"$home/slurmd.log"
for try in $(seq 60); do
  sinfo --noheader --format=%t 2>/dev/null | grep -q idle && break
  if [ "$try" -eq 60 ]; then
    echo "FAILED: the node does not come up" >&2
    tail -n 20 "$home"/*.log >&2
    exit 1
  fi
  sleep 0.5
done
"$@"
