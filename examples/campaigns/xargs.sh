#!/bin/sh
# The missing shards of a campaign, so many at a time: xargs.sh DIR PROCESSES
mechaudit campaign status "$1" --missing |
    xargs -P "$2" -I K mechaudit campaign run "$1" --jobs 1 --shard K
