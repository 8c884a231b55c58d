import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Api, carrying } from '../../web/api.js';
import { KeyWanted, Overloaded, Refused, Unreachable } from '../../web/failures.js';

/** @param {() => Response | Promise<Response>} respond */
function bench(respond) {
  /** @type {{address: string, options: RequestInit}[]} */
  const calls = [];
  const api = new Api(async (address, options) => {
    calls.push({ address, options });
    return respond();
  });
  return { api, calls };
}

const kOptions = { profile: 'painted', limit: 20, seq: 3 };
const kSignal = new AbortController().signal;
const ok = () => Response.json({ matches: [] });

test('a painting is posted as a PNG made at the last moment', async () => {
  const { api, calls } = bench(ok);
  const blob = new Blob(['png'], { type: 'image/png' });
  await api.query({ kind: 'painting', png: async () => blob }, kOptions, kSignal);
  const [{ address, options }] = calls;
  assert.equal(address, 'query?profile=painted&limit=20&seq=3');
  assert.equal(options.method, 'POST');
  assert.equal(options.body, blob);
  assert.equal(new Headers(options.headers).get('Content-Type'), 'image/png');
  assert.equal(options.signal, kSignal);
});

test('a file is posted as the part "file", with the type of the form', async () => {
  const { api, calls } = bench(ok);
  const file = /** @type {File} */ (Object.assign(new Blob(['text']), { name: 'a.heic' }));
  await api.query({ kind: 'file', file }, kOptions, kSignal);
  const { body, headers } = calls[0].options;
  assert.ok(body instanceof FormData);
  assert.equal(/** @type {File} */ (body.get('file')).name, 'a.heic');
  assert.equal(new Headers(headers).get('Content-Type'), null);
});

test('ids and signatures are asked for by address', async () => {
  const { api, calls } = bench(ok);
  await api.query({ kind: 'id', id: 12 }, kOptions, kSignal);
  await api.query({ kind: 'signature', signature: 'a+b/=&' }, kOptions, kSignal);
  assert.equal(calls[0].address, 'query?id=12&profile=painted&limit=20&seq=3');
  assert.equal(calls[1].address, 'query?signature=a%2Bb%2F%3D%26&profile=painted&limit=20&seq=3');
});

test('what differs from the plain search goes with the query, as far as its source allows', async () => {
  const { api, calls } = bench(ok);
  const asking = { ...kOptions, options: { partial: /** @type {const} */ (true), tags: 'a,b' }, explain: true };
  const blob = new Blob(['png'], { type: 'image/png' });
  await api.query({ kind: 'painting', png: async () => blob }, asking, kSignal);
  await api.query({ kind: 'id', id: 12 }, asking);
  assert.equal(calls[0].address, 'query?profile=painted&limit=20&seq=3&partial=true&tags=a%2Cb&explain=true');
  assert.equal(calls[1].address, 'query?id=12&profile=painted&limit=20&seq=3&tags=a%2Cb&explain=true');
});

test('a document is carried as JSON, and an order needs no answer', async () => {
  const { api, calls } = bench(() => new Response(null, { status: 204 }));
  await api.order('feedback', carrying('POST', { target: 3 }));
  const { method, headers, body } = calls[0].options;
  assert.deepEqual([method, new Headers(headers).get('Content-Type'), body], ['POST', 'application/json', '{"target":3}']);
  await assert.rejects(bench(() => new Response('', { status: 404 })).api.order('x', {}), Refused);
});

test('the key goes with every call once there is one', async () => {
  const { api, calls } = bench(ok);
  await api.status();
  api.key = 'secret';
  await api.status();
  const sent = calls.map(({ options }) => new Headers(options.headers).get('Authorization'));
  assert.deepEqual(sent, [null, 'Bearer secret']);
});

test('a problem document is told in its own words', async () => {
  const body = { title: 'Unsupported', status: 415, detail: 'this is text/plain', code: 'not_a_picture' };
  const { api } = bench(() => Response.json(body, { status: 415 }));
  await assert.rejects(api.status(), (error) => {
    assert.ok(error instanceof Refused);
    assert.deepEqual([error.status, error.message, error.code], [415, 'this is text/plain', 'not_a_picture']);
    return true;
  });
});

test('a failure without a document is told by its status', async () => {
  const { api } = bench(() => new Response('<html>', { status: 500 }));
  await assert.rejects(api.status(), { name: 'Refused', message: 'The server answered with status 500.' });
});

test('each kind of failure has its class', async () => {
  /** @type {[() => Response | Promise<Response>, new (...rest: any[]) => Error][]} */
  const kinds = [
    [() => new Response('', { status: 401 }), KeyWanted],
    [() => new Response('', { status: 502 }), Unreachable],
    [() => new Response('', { status: 504 }), Unreachable],
    [() => new Response('', { status: 503 }), Overloaded],
    [() => new Response('', { status: 429 }), Overloaded],
    [() => new Response('{"matches":', { status: 200 }), Unreachable],
    [() => Promise.reject(new TypeError('Failed to fetch')), Unreachable],
  ];
  for (const [respond, kind] of kinds) await assert.rejects(bench(respond).api.status(), kind);
});

test('an overloaded server says for how long; without a word it is one second', async () => {
  for (const [header, ms] of /** @type {[string | null, number][]} */ ([['7', 7000], [null, 1000], ['soon', 1000]])) {
    /** @type {Record<string, string>} */
    const headers = header === null ? {} : { 'Retry-After': header };
    const { api } = bench(() => new Response('', { status: 503, headers }));
    await assert.rejects(api.status(), { retryAfterMs: ms });
  }
});

test('alive() is an answer, never an error', async () => {
  assert.equal(await bench(ok).api.alive(), true);
  assert.equal(await bench(() => new Response('', { status: 500 })).api.alive(), false);
  assert.equal(await bench(() => Promise.reject(new TypeError('gone'))).api.alive(), false);
});

test('a picture that is not served has no type', async () => {
  const { api, calls } = bench(() => new Response('', { headers: { 'Content-Type': 'image/png' } }));
  assert.equal(await api.typeOf('images/1/original'), 'image/png');
  assert.equal(calls[0].options.method, 'HEAD');
  assert.equal(await bench(() => new Response('', { status: 404 })).api.typeOf('x'), null);
  await assert.rejects(bench(() => Promise.reject(new TypeError('gone'))).api.typeOf('x'), Unreachable);
});
