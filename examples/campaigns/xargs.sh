#!/bin/sh
# Runs the missing shards of a campaign, PROCESSES at a time: xargs.sh DIR PROCESSES
mechaudit campaign status "$1" --missing |
    xargs -r -P "$2" -n 1 mechaudit campaign run "$1" --jobs 1 --shard
