"""A cluster of machines: an executor whose calls run on the workers of a Dask scheduler.

A worker of the cluster hands each call to a `WorkerPool` of its own. So the limits of time and
memory hold there as they hold here, and a file that ends a process ends no worker of the cluster.
"""

from __future__ import annotations

import logging
import pickle
import socket
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any, ParamSpec, TypeVar
from urllib.parse import urlsplit

from footfit.errors import BadOption, ClusterUnusable, FootfitError
from footfit.pipeline.batch.run_manifest import with_said
from footfit.pipeline.batch.sources import Source, source_bytes
from footfit.pipeline.batch.workers import WorkerPool, settle
from footfit.version import __version__

P = ParamSpec("P")
T = TypeVar("T")
NOT_INSTALLED = (
    "--scheduler needs Dask, which is not installed; type: python -m pip install 'footfit[cluster]'"
)


@dataclass(frozen=True, slots=True)
class Patience:
    """How long a command waits for a cluster, in seconds.

    ``resubmissions`` is how often a call is sent again that Dask gave up: it does so after three
    dead workers.
    """

    to_connect_s: float = 15.0
    for_a_worker_s: float = 15.0
    look_every_s: float = 1.0
    without_workers_s: float = 60.0
    resubmissions: int = 3


PATIENCE = Patience()


class Cluster(Executor):
    """The workers of a Dask scheduler behind the interface of ``concurrent.futures``.

    The bytes of a scan are read here and travel with the call. Workers send plain values back. A
    call whose worker dies is done by another one.

    Raises
    ------
    BadOption
        The address is not valid, or Dask is not installed.
    ClusterUnusable
        The scheduler does not answer, it has no worker, or a worker has another footfit.
    """

    def __init__(self, address: str, patience: Patience = PATIENCE) -> None:
        self.address, self._patience = address, patience
        self._client = _client(address, patience)
        self._pending: dict[Future[Any], int] = {}
        self._lock = threading.Lock()
        self._closing = threading.Event()
        try:
            self._require_workers()
            self.width = self._threads()
        except BaseException:
            self._client.close(timeout=1)
            raise
        self._executor = self._client.get_executor(pure=False)
        threading.Thread(target=self._watch, daemon=True).start()

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Call ``fn`` on a worker. It must be picklable, and so must its arguments."""
        future: Future[T] = Future()
        future.set_running_or_notify_cancel()
        if any(_stays(argument) for argument in args):
            settle(future, *_answer(partial(fn, *args, **kwargs)))
            return future
        try:
            call = pickle.dumps((fn, [_with_bytes(argument) for argument in args], kwargs))
        except FootfitError as error:  # the file cannot be read
            future.set_exception(error)
            return future
        with self._lock:
            self._pending[future] = 0
        self._send(call, future)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Leave the cluster, which goes on; what it has not answered is cancelled there."""
        if wait and not cancel_futures:
            from concurrent.futures import wait as wait_for

            wait_for(list(self._pending))
        self._closing.set()
        with suppress(Exception):  # the scheduler may be gone
            self._client.close(timeout=1)

    def __exit__(self, *error: object) -> None:
        """Leave the cluster at once if the block failed or was stopped."""
        self.shutdown(cancel_futures=error[0] is not None)

    def _send(self, call: bytes, future: Future[Any]) -> None:
        sent = self._executor.submit(answer_on_worker, __version__, call)
        sent.add_done_callback(partial(self._take, call, future))

    def _take(self, call: bytes, future: Future[Any], sent: Future[Any]) -> None:
        """Take an answer; send the call again if its workers died."""
        if self._closing.is_set():
            return
        if sent.cancelled():
            self._settle(future, None, self._gone())
            return
        error = sent.exception()
        if error is None:
            self._settle(future, *sent.result())
            return
        if type(error).__name__ == "KilledWorker":
            with self._lock:
                tries = self._pending[future] = self._pending.get(future, 0) + 1
            if tries <= self._patience.resubmissions:
                self._send(call, future)
                return
            words = "each worker that had a file died: look at the workers, then try again"
            error = ClusterUnusable(words, self.address)
        self._settle(future, None, error)

    def _settle(self, future: Future[Any], answer: object, error: BaseException | None) -> None:
        with self._lock:
            self._pending.pop(future, None)
        settle(future, answer, error)

    def _gone(self) -> ClusterUnusable:
        words = "the scheduler has gone away; start it again, and run the command again"
        return ClusterUnusable(words, self.address)

    def _threads(self) -> int:
        return max(1, int(sum(self._client.nthreads().values())))

    def _require_workers(self) -> None:
        wait_s = self._patience.for_a_worker_s
        try:
            self._client.wait_for_workers(1, timeout=wait_s)
        except TimeoutError as error:
            words = f"has had no worker for {wait_s:g} s; type: dask worker {self.address}"
            raise ClusterUnusable(words, self.address) from error
        versions = self._client.get_versions(packages=["footfit"])["workers"]
        require_same_version(
            {worker: details["packages"].get("footfit") for worker, details in versions.items()}
        )

    def _watch(self) -> None:
        """In a thread: count the workers; end the wait if there is none or no scheduler."""
        alone_s = 0.0
        while not self._closing.wait(self._patience.look_every_s):
            error: ClusterUnusable | None = None
            try:
                workers = self._client.nthreads()
            except Exception:  # noqa: BLE001 - whatever Dask raises, the scheduler does not answer
                workers, error = {}, self._gone() if self._client.status != "running" else None
            self.width = max(1, sum(workers.values()))
            alone_s = 0.0 if workers else alone_s + self._patience.look_every_s
            if alone_s >= self._patience.without_workers_s:
                words = f"has had no worker for {alone_s:g} s; start workers, and run it again"
                error = ClusterUnusable(words, self.address)
            if error is not None:
                for future in list(self._pending):
                    self._settle(future, None, error)


def require_same_version(workers: Mapping[str, str | None]) -> None:
    """Refuse workers that have another footfit, or none, by their addresses.

    Raises
    ------
    ClusterUnusable
        There is one.
    """
    for worker, version in workers.items():
        if version != __version__:
            has = f"has footfit {version}" if version else "has no footfit"
            words = f"{has}, and this is {__version__}: install the same version on every worker"
            raise ClusterUnusable(words, worker)


def answer_on_worker(version: str, call: bytes) -> tuple[Any, BaseException | None]:
    """On a worker: the answer of a call or its error, from a process of this worker's pool."""
    from distributed import get_worker

    worker = get_worker()
    try:
        require_same_version({worker.address: version})
    except ClusterUnusable:
        words = f"has footfit {__version__}, and the command {version}: install the same version"
        return None, ClusterUnusable(words, worker.address)
    return _answer(lambda: _done_in_pool(_pool(worker.state.nthreads), call))


def _done_in_pool(pool: WorkerPool, call: bytes) -> Any:
    fn, args, kwargs = pickle.loads(call)
    return pool.submit(fn, *args, **kwargs).result()


@lru_cache(maxsize=1)
def _pool(jobs: int) -> WorkerPool:
    """The processes of this worker; they wait for the next call until the worker ends."""
    return WorkerPool(jobs)


def _answer(call: Callable[[], T]) -> tuple[T | None, BaseException | None]:
    try:
        return call(), None
    except Exception as error:  # noqa: BLE001 - it is raised where the call was asked for
        return None, error


def _stays(item: object) -> bool:
    """Whether an item cannot travel: a stored last is read from a catalogue of this machine."""
    source = getattr(item, "source", item)
    return isinstance(source, Source) and source.stored is not None


def _with_bytes(item: Any) -> Any:
    """An item with the bytes of its file, and with what a manifest beside it says of it: the
    workers do not see this machine's files.
    """
    source = getattr(item, "source", item)
    if not isinstance(source, Source):
        return item
    full = with_said(source)
    if source.data is None and source.scan is None:
        full = replace(full, data=source_bytes(source))
    return full if source is item else replace(item, source=full)


def _client(address: str, patience: Patience) -> Any:
    """A client of the scheduler.

    Raises
    ------
    BadOption, ClusterUnusable
        As `Cluster`.
    """
    _require_scheduler(address, patience)
    try:
        import dask.config
        import distributed
    except ImportError as error:
        raise BadOption(NOT_INSTALLED) from error
    for name in list(logging.root.manager.loggerDict):  # Dask would write to stderr
        if name.split(".")[0] in ("distributed", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    if address.startswith("tls") and not _has_certificates(distributed.Security()):
        words = "tls:// needs certificates, and Dask's settings name none; docs/cluster.md says how"
        raise ClusterUnusable(words, address)
    wait = f"{patience.to_connect_s:g}s"
    dask.config.set(
        {
            "distributed.comm.timeouts.connect": wait,
            "distributed.admin.large-graph-warning-threshold": "10GB",
        }
    )
    client = distributed.Client.__new__(distributed.Client)
    connect = partial(client.__init__, address, timeout=wait, set_as_default=False)
    connected: Future[Any] = Future()
    # Dask may wait for ever if another program listens there.
    threading.Thread(target=lambda: settle(connected, *_answer(connect)), daemon=True).start()
    try:
        connected.result(patience.to_connect_s + patience.look_every_s)
        return client
    except Exception as error:
        client.status = "closed"  # else its end waits 30 s to close what was never open
        words = "what answers there is no Dask scheduler, or one of another version of Dask"
        raise ClusterUnusable(f"{words}; look at the address", address) from error


def _has_certificates(security: Any) -> bool:
    return security.get_connection_args("client").get("ssl_context") is not None


def _require_scheduler(address: str, patience: Patience) -> None:
    """Refuse an address that is not valid, or at which nothing listens: Dask would wait for it."""
    try:
        parts = urlsplit(address)
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    _, has_user, shown = address.rpartition("@")
    if has_user:
        words = "--scheduler takes tcp://HOST:PORT or tls://HOST:PORT, without a user or a password"
        raise BadOption(f"{words} before {shown!r}")
    if not host or not port or parts.scheme not in ("tcp", "tls"):
        raise BadOption(f"--scheduler takes tcp://HOST:PORT or tls://HOST:PORT, not {address!r}")
    try:
        socket.create_connection((host, port), patience.to_connect_s).close()
    except OSError as error:
        words = f"no scheduler answers there ({error.strerror or error}); type: dask scheduler"
        raise ClusterUnusable(words, address) from error
