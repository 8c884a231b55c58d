// The real executables, as a newcomer's first minute runs them: a gallery is painted,
// ingested and served.

import { spawn } from 'node:child_process';
import { copyFileSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const kWeb = fileURLToPath(new URL('../../../web/', import.meta.url));
const kStartMs = 30_000;

/** A gallery in a folder of its own, served by a daemon at a free port. */
export class GalleryServer {
  #bin;
  #folder = mkdtempSync(join(tmpdir(), 'haarmony-gallery-'));
  /** @type {import('node:child_process').ChildProcess | null} */ #daemon = null;
  #port = 0;

  /** @param {string} bin folder with haarmonyd, haarmony-ingest and haarmony-gallery */
  constructor(bin) {
    this.#bin = bin;
  }

  get address() {
    return `http://127.0.0.1:${this.#port}/`;
  }

  /** @returns {string[]} paths of the pictures */
  get files() {
    const pictures = join(this.#folder, 'pictures');
    return readdirSync(pictures)
      .sort()
      .map((name) => join(pictures, name));
  }

  /**
   * @param {number} count
   * @param {number} [copies] so many of the first pictures are there twice
   */
  async fill(count, copies = 0) {
    const pictures = join(this.#folder, 'pictures');
    await this.#run('haarmony-gallery', ['--out', pictures, '--count', String(count), '--seed', '1']);
    for (const file of this.files.slice(0, copies)) copyFileSync(file, join(pictures, `twin-${basename(file)}`));
    await this.#run('haarmony-ingest', ['--db', this.#database, '--progress', 'none', pictures]);
  }

  /** May be called again after stop(): it serves at the same port. */
  async start() {
    const daemon = spawn(
      join(this.#bin, 'haarmonyd'),
      [
        ...['--db', this.#database, '--web', kWeb, '--listen', `127.0.0.1:${this.#port}`],
        ...['--media-root', join(this.#folder, 'pictures'), '--log-level', 'warn'],
      ],
      { stdio: ['ignore', 'pipe', 'inherit'] },
    );
    this.#daemon = daemon;
    this.#port = await new Promise((resolve, reject) => {
      const deadline = setTimeout(() => reject(new Error('haarmonyd did not listen')), kStartMs);
      daemon.once('error', reject);
      daemon.once('exit', (code) => reject(new Error(`haarmonyd ended with ${code}`)));
      createInterface({ input: daemon.stdout }).on('line', (line) => {
        const [, port] = line.match(/listening on http:\/\/127\.0\.0\.1:(\d+)/) ?? [];
        if (port === undefined) return;
        clearTimeout(deadline);
        resolve(Number(port));
      });
    });
  }

  /** @param {NodeJS.Signals} [signal] */
  async stop(signal = 'SIGTERM') {
    const daemon = this.#daemon;
    if (!daemon || daemon.exitCode !== null || daemon.signalCode !== null) return;
    const ended = new Promise((resolve) => daemon.once('exit', resolve));
    daemon.kill(signal);
    await ended;
  }

  remove() {
    rmSync(this.#folder, { recursive: true, force: true });
  }

  get #database() {
    return join(this.#folder, 'gallery.db');
  }

  /**
   * @param {string} name
   * @param {string[]} args
   */
  #run(name, args) {
    return new Promise((resolve, reject) => {
      const child = spawn(join(this.#bin, name), args, { stdio: ['ignore', 'ignore', 'inherit'] });
      child.once('error', reject);
      child.once('exit', (code) =>
        code === 0 ? resolve(undefined) : reject(new Error(`${name} ended with ${code}`)),
      );
    });
  }
}
