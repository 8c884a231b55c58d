// What this server can do, from its own description of its interface. An older server, or one
// that describes nothing, can do nothing beyond the plain search, and the page offers nothing.

/** @typedef {{name?: string, in?: string, schema?: {enum?: unknown[]}, $ref?: string}} Parameter */
/**
 * @typedef {object} Description an OpenAPI document, as far as the page reads it
 * @property {Record<string, Record<string, {parameters?: Parameter[]}>>} [paths]
 * @property {{parameters?: Record<string, Parameter>}} [components]
 */

const kParameters = '#/components/parameters/';

export class Capabilities {
  #paths;
  /** By name. @type {Map<string, Parameter>} */ #options = new Map();

  /** @param {Description | null} description */
  constructor(description) {
    this.#paths = description?.paths ?? {};
    const named = description?.components?.parameters ?? {};
    for (const each of this.#paths['/query']?.get?.parameters ?? []) {
      const parameter = each.$ref ? named[each.$ref.replace(kParameters, '')] : each;
      if (parameter?.name) this.#options.set(parameter.name, parameter);
    }
  }

  /**
   * @param {string} path as the description writes it
   * @param {'get' | 'post' | 'delete'} [method]
   */
  answers(path, method = 'get') {
    return this.#paths[path]?.[method] !== undefined;
  }

  /**
   * Whether a query may carry this option with this value.
   * @param {string} option
   * @param {unknown} [value] any, if none is given
   */
  takes(option, value) {
    const parameter = this.#options.get(option);
    if (!parameter) return false;
    const allowed = parameter.schema?.enum;
    return allowed === undefined || value === undefined || allowed.includes(value);
  }
}
