#!/bin/sh
# The same by GNU parallel, with what it has for other machines: parallel.sh DIR PROCESSES [OPTION…]
#
#   parallel.sh DIR 8 --eta --sshloginfile hosts     # DIR on a file system that all hosts share
processes=$2
export dir="$1"
shift 2
mechaudit campaign status "$dir" --missing |
    parallel --env dir --retries 3 -j "$processes" "$@" 'mechaudit campaign run "$dir" --jobs 1 --shard {}'
